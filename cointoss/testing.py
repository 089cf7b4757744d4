"""The place where the plugin of pytest was; it is in cointoss_yardstick."""

raise ImportError(
    "cointoss.testing is cointoss_yardstick.testing now; accepted: pip install cointoss-yardstick"
)
