"""The paper's figures and claims, and studies, for `cointoss reproduce`; imports the rooms below."""
