//! A compressed array of VTK's XML files: the number of blocks, the size of a block, the size of
//! the last block if it is shorter (else 0), the compressed size of each; then the blocks. All
//! sizes are little-endian u64 here, as the file's `header_type` says.

use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;

/// Uncompressed bytes of a block: readers decompress one at a time.
pub(super) const BLOCK: usize = 1 << 17;

/// Collects bytes and compresses them block by block, so that an array is never held twice.
pub(super) struct Blocks {
    pending: Vec<u8>,
    sizes: Vec<u64>,
    last: u64,
    payload: Vec<u8>,
}

impl Blocks {
    pub(super) fn new() -> Self {
        Self { pending: Vec::new(), sizes: Vec::new(), last: 0, payload: Vec::new() }
    }

    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.pending.extend_from_slice(bytes);
        if self.pending.len() >= BLOCK {
            let rest = self.pending.split_off(BLOCK);
            self.close();
            self.pending = rest;
        }
    }

    /// Header and blocks.
    pub(super) fn finish(mut self) -> Vec<u8> {
        if !self.pending.is_empty() {
            self.last = self.pending.len() as u64;
            self.close();
        }
        let header = [self.sizes.len() as u64, BLOCK as u64, self.last];
        let header = header.iter().chain(&self.sizes).flat_map(|size| size.to_le_bytes());
        header.chain(self.payload.iter().copied()).collect()
    }

    fn close(&mut self) {
        let before = self.payload.len();
        let payload = std::mem::take(&mut self.payload);
        let mut encoder = ZlibEncoder::new(payload, Compression::fast());
        let written = encoder.write_all(&self.pending).and_then(|()| encoder.finish());
        self.payload = written.expect("memory takes every byte");
        self.sizes.push((self.payload.len() - before) as u64);
        self.pending.clear();
    }
}
