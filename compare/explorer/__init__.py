"""The explorer: a map in a browser, each pixel tossed at a click; imports sweep and below."""
