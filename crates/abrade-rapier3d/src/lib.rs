//! Part of abrade.
