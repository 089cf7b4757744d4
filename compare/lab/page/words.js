// Numbers in words, and what the lab calls the fields that it shows.

// A value in full where ten digits suffice, else with ten digits.
export const shownAs = (value) => String(Number(value.toPrecision(10)));

// On sliders, axes and read-outs alike.
export const LABELS = {
  "coin.radius": "radius", "coin.thickness": "thickness", "coin.mass": "mass",
  "coin.center_of_mass.xi": "mass centre aside", "coin.center_of_mass.zeta": "mass centre up",
  "floor.restitution": "restitution χ", "floor.restitution_exponent": "restitution exponent p", "floor.friction": "friction μ",
  "release.position.z": "height", "release.velocity.x": "speed aside", "release.velocity.z": "speed upwards",
  "release.angular_velocity.eta": "spin about η", "release.angular_velocity.xi": "spin about ξ",
  "release.angular_velocity.zeta": "spin about the coin's axis", "release.angles.theta": "tilt",
};

// What a symbol stands for, below its slider.
export const HINTS = {
  "floor.restitution": "the part of its speed that a bounce gives back",
  "floor.restitution_exponent": "a faster bounce gives back less: χ is the part at 1 m/s",
  "floor.friction": "the floor's grip, as a part of its push",
  "release.angular_velocity.eta": "η is the diameter about which the coin turns over",
};
