"""Wave theories and irregular waves."""
