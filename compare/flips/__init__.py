"""How much people's coins wobble, from how often they show the first side; may import fitting and shares."""
