#include <pavior/cad/brep.hpp>
