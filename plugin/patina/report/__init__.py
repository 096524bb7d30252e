"""The page that `patina record --report` writes about one render."""
