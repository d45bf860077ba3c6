"""Arms of other packages' models, and back."""
