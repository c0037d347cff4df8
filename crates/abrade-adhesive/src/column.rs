//! A column of numbers that begins with a line of the cache: blocks of four then do not lie across
//! two.

use std::ops::{Deref, DerefMut};

/// Size of a cache line, in bytes and in numbers.
const LINE: usize = 64;
const NUMBERS: usize = LINE / size_of::<f64>();

/// A column of numbers. A copy holds the same numbers, wherever they begin.
#[derive(Debug)]
pub(crate) struct Column {
    room: Vec<f64>,
    start: usize,
    count: usize,
}

impl Column {
    /// `count` times `value`.
    pub(crate) fn new(value: f64, count: usize) -> Self {
        let room = vec![value; count + NUMBERS];
        let start = room.as_ptr().align_offset(LINE).min(NUMBERS);
        Self { room, start, count }
    }
}

impl Deref for Column {
    type Target = [f64];
    #[inline(always)]
    fn deref(&self) -> &[f64] {
        &self.room[self.start..self.start + self.count]
    }
}

impl DerefMut for Column {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f64] {
        &mut self.room[self.start..self.start + self.count]
    }
}

impl Clone for Column {
    fn clone(&self) -> Self {
        let mut copy = Self::new(0.0, self.count);
        copy.copy_from_slice(self);
        copy
    }
}

impl PartialEq for Column {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}
