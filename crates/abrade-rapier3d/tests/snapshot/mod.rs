//! A world and its wear, saved in the middle of a contact: another process goes on from the bytes
//! as this one does, to the bit, and no bytes make reading or stepping panic. Both precisions run
//! the same tests.

mod cases;
mod damage;
mod process;
mod save;
