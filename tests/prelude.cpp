// Empty. Its target makes the precompiled header that all tests share.
