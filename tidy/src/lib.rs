//! House rules as one test.
