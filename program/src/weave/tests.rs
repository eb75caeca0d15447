//! The mesh as a whole: no yarn goes into another, and all are as far apart as was asked for.
