"""OpenFAST's files."""
