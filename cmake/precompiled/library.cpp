// Only its header is wanted.
