//! Empty: the root package holds the top-level tests and examples, nothing else.
