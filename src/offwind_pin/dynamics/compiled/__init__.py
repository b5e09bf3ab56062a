"""The O(N) chain in compiled code."""
