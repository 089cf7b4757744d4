"""The figures, claims and studies, one folder each; they never import each other."""
