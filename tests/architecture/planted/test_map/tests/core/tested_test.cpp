#include <pavior/core/tested.hpp>
