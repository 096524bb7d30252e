"""Charts of what methods and renderers cost, against how far they are off."""
