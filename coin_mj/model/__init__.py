"""MuJoCo's model of the coin: settings, scene, state, air; imports nothing else of coin_mj."""
