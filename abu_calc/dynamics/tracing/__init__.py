"""The equations told in another language: plain Python, heyoka."""
