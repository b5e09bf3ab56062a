"""What several tests share: fits, differences, plain structures."""
