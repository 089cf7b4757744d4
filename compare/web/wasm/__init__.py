"""The analytic engine as WebAssembly: its compiled functions, lowered for a browser."""
