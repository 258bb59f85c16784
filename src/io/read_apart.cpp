#include "read_apart.hpp"

#include <pavior/core/error.hpp>

#include "../common/bare_message.hpp"
#include "../common/child_process.hpp"

#include <cmath>
#include <filesystem>
#include <new>
#include <system_error>

namespace pavior::io {

namespace {

/// Ends a message of data, and one of a FileError.
constexpr char data_follows = 'd';
constexpr char error_follows = 'e';

double seconds_for(const std::string& file) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    return error ? 10 : std::ceil(10 + 1e-5 * static_cast<double>(size));
}

}  // namespace

std::string read_apart(const std::string& file, const std::function<void(detail::ByteWriter&)>& read) {
    using End = detail::ChildAnswer::End;
    const auto refused = [&](const std::string& message, const Error::Ids& ids) {
        detail::ByteWriter writer;
        writer.add(message);
        writer.add(ids);
        return writer.take() + error_follows;
    };
    const auto task = [&] {
        try {
            detail::ByteWriter writer;
            read(writer);
            std::string bytes = writer.take();
            bytes += data_follows;
            return bytes;
        } catch (const FileError& error) {
            return refused(detail::bare_message(file, error.what()), error.ids());
        } catch (const std::bad_alloc&) {
            return refused("asks for more memory than there is", {});
        }
    };
    const double seconds = seconds_for(file);
    detail::ChildAnswer answer = detail::run_in_child(task, {.seconds = seconds});
    switch (answer.end) {
        case End::answered: break;
        case End::threw: throw FileError(file, answer.reason);
        case End::timed_out:
            throw FileError(
                file, "its reader did not come back within " + std::to_string(static_cast<long long>(seconds)) + " s");
        default: throw FileError(file, "its reader " + answer.reason);
    }
    const char kind = answer.bytes.back();
    answer.bytes.pop_back();
    if (kind == error_follows) {
        detail::ByteReader reader(answer.bytes);
        std::string message;
        Error::Ids ids;
        reader.get(message);
        reader.get(ids);
        throw FileError(file, message, std::move(ids));
    }
    return std::move(answer.bytes);
}

}  // namespace pavior::io
