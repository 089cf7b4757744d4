"""How MuJoCo's coin moves: in flight, in an impact, in sustained contact; imports model."""
