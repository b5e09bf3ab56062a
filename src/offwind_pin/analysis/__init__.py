"""Static, modal, time-domain and other analyses of a system."""
