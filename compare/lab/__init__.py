"""The lab: a page that tosses coins by itself; imports web and below."""
