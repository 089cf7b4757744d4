"""How tosses by a hand end, along fields of a scenario; imports sweep and what is below it."""
