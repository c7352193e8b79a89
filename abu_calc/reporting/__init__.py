"""Results as text, JSON, TOML, CSV, pages, charts and drawings. Nothing is computed here."""
