#pragma once
struct Unnamed {};
inline int forgotten(int x) { return x; }
