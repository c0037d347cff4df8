//! A number that tells what a case was made of.

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), the same on every machine.
#[derive(Clone, Debug)]
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// That of this program's version; builds of one version are alike to it.
    pub(crate) fn new() -> Self {
        let mut hash = Self(0xcbf2_9ce4_8422_2325);
        hash.add(env!("CARGO_PKG_VERSION").as_bytes());
        hash
    }

    pub(crate) fn add(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// As text.
    pub(crate) fn text(&self) -> String {
        format!("{:016x}", self.0)
    }
}
