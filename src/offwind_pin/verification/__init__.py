"""Every claim that has a check: one ledger of quantities, references and tolerances."""
