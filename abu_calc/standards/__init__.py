"""Facts with source and edition: balls, balance grades, ISO 286, ISO 492, bearings, hands, vibration."""
