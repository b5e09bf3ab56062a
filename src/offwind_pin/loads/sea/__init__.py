"""Sea states, wave kinematics, current, hydrodynamic loads."""
