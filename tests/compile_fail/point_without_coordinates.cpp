// expect: satisf.*point_like
#include <pavior/math/point.hpp>

#include <array>

struct Named {
    double x = 0.0, y = 0.0, z = 0.0;
};

pavior::Vec3 copy() {
#ifdef MISUSE
    return pavior::to_vec3(Named{});
#else
    return pavior::to_vec3(std::array<double, 3>{});
#endif
}
