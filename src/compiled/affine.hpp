#pragma once
// All templates of affine/ for one scalar and dimension, each pair in a source of its own: together they take minutes.

#include <pavior/affine/affinity.hpp>
#include <pavior/affine/fit.hpp>
#include <pavior/affine/functionals.hpp>

#define PAVIOR_AFFINE_INSTANCES(Scalar, N) \
    PAVIOR_CENTRING(, Scalar, N)           \
    PAVIOR_PSEUDO_NORMAL(, Scalar, N)      \
    PAVIOR_LOOP_PAIR(, Scalar, N)          \
    PAVIOR_LOOP_NORMALS(, Scalar, N)       \
    PAVIOR_MINIMIZERS(, Scalar, N)         \
    PAVIOR_OFFSET_PRESERVING(, Scalar, N)  \
    PAVIOR_FIT_CONSTRAINED(, Scalar, N)    \
    PAVIOR_AFFINITY(, Scalar, N) PAVIOR_FUNCTIONALS(, Scalar, N) PAVIOR_FIT_AFFINE(, Scalar, N)
