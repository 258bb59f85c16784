// What a header must not do: a function that is neither a template nor inline.
int forgotten_inline() { return 1; }
