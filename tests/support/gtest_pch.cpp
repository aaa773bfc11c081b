// Holds nothing: its target makes the precompiled header that the tests share.
