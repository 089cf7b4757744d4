"""What counts of flips say of a coin, and of the hand that tosses it; may import fitting and shares."""
