// Nothing: a precompiled header wants a source file to belong to.
