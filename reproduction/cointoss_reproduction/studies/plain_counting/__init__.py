"""Shares of uncertain tosses and of coins on edge by plain counting."""
