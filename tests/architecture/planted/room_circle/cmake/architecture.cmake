# Each include is allowed, but the two rooms stand above each other.
set(rooms core math)
set(may_include_core math)
set(may_include_math core)
