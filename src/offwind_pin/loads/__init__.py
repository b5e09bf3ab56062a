"""The load contract, and the loads by origin."""
