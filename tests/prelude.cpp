// Nothing: its target makes the precompiled header that all tests share.
