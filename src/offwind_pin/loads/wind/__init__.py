"""Wind profiles, rotor thrust, tower drag."""
