"""The material page: any material in a browser, with sliders."""
