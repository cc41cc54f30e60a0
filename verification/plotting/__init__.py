"""The pictures of a results folder: reading it, the style, the body's pictures, the contact boundary's."""
