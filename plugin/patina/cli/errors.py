"""What a user did or met, as opposed to a defect of Patina."""


class CommandError(Exception):
    """Ends the command with exit status 1 and this one-line reason."""


class UsageError(Exception):
    """Ends the command with exit status 2: the arguments cannot be understood."""
