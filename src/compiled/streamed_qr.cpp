#include <pavior/math/streamed_qr.hpp>

namespace pavior {

template class StreamedQr<float, 4>;
template class StreamedQr<float, 6>;
template class StreamedQr<float, 8>;
template class StreamedQr<float, Eigen::Dynamic>;
template class StreamedQr<double, 4>;
template class StreamedQr<double, 6>;
template class StreamedQr<double, 8>;
template class StreamedQr<double, Eigen::Dynamic>;

}  // namespace pavior
