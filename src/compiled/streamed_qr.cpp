#include <pavior/math/streamed_qr.hpp>

namespace pavior {

template class StreamedQr<double, 4>;
template class StreamedQr<double, 6>;
template class StreamedQr<double, 8>;
template class StreamedQr<double, Eigen::Dynamic>;

}  // namespace pavior
