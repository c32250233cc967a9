"""Pictures with matplotlib: each function draws into the given axes, or into new ones, and returns them.

The style applies to the pictures of jounce only; the settings of matplotlib are unchanged.
"""
