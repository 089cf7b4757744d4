"""What every study is run, checked and shown by."""
