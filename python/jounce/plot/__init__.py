"""Pictures with matplotlib: each function draws into the axes that it is given, or into new ones, and gives them back.

The look is set for the pictures of jounce alone; matplotlib's own settings stay as they are.
"""
