#pragma once
#include <gmsh.h>
