"""The one exception for input a user can mend."""


class InputError(ValueError):
    """Bad input: the message is one sentence naming the file or key, and the remedy."""
