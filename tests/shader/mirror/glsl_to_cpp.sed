# Turns a file of the shader library into C++ (sed -E), line by line, where the languages differ. The result
# is included in a namespace that has vocabulary.inc, with `real` for float. See mirror.h.

s@ *//.*@@
# library.inc includes each file once, in order; code for C++ alone is left out.
/^#ifdef __cplusplus/,/^#endif/d
# Of kernels, those for all scenes.
/^#ifdef DUOLUX_PLAIN/,/^#else/d
/^#(include|extension|ifndef|define|endif)\b/d
/^ *DUOLUX_(BEGIN|END|COUNT_NODE|COUNT_PAIR)$/d

# Numbers and scalars: all arithmetic uses `real`.
s/\b(([0-9]+\.[0-9]*|[0-9]*\.[0-9]+)([eE][-+]?[0-9]+)?|[0-9]+[eE][-+]?[0-9]+)f?\b/real(\1)/g
s/\bfloat\b/real/g
s/\bprecise //g

# Parameters by reference, swizzles, arrays as values.
s/\b(in)?out (\w+) (\w+)/\2\& \3/g
s/\.([xyzw]{2,4})\b/->*swizzle::\1/g
s/\buint\[([0-9]+)\]/Array<\1>/g
s/\buint (\w+)\[([0-9]+)\];/Array<\2> \1;/g

# Constants of kernels become variables that tests may set.
s/^layout\(constant_id = [A-Za-z0-9]+\) const (.*)/inline \1/
s/^DUOLUX_CONST/inline constexpr/
s/^const /inline const /

# Several files may include functions and globals.
s/^(\w+(<[0-9]+>)? \w+\()/inline \1/
s/^(uint \w+\[)/inline \1/
