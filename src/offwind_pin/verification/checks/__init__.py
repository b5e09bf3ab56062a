"""What the ledger's rows compute; each function gives what was found, and a closed form beside."""
