"""The same equations by Pinocchio."""
