// Nothing: a target must have a source for its precompiled headers.
