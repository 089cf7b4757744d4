"""Steps of MuJoCo's coin: in flight, in an impact, in sustained contact; imports model."""
