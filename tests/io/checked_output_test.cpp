#include "io/checked_output.hpp"

#include "support/catch.hpp"

#include <pavior/core/error.hpp>
#include <pavior/io/mesh_file.hpp>

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>

using namespace pavior;
namespace fs = std::filesystem;

namespace {

std::string scratch() { return fs::temp_directory_path() / "pavior_checked_output_test"; }

std::string content() {
    std::ostringstream text;
    text << std::ifstream(scratch(), std::ios::binary).rdbuf();
    return text.str();
}

}  // namespace

TEST_CASE("numbers have as many digits as they need, or seventeen") {
    io::CheckedOutput out(scratch(), "shown");
    out.number(-12);
    out.text(" ");
    out.number(std::size_t{18446744073709551615U});
    out.text(" ");
    out.number(0.1);
    out.text(" ");
    out.number(0.1, 17);
    out.text(" ");
    out.number(-1.7976931348623157e308, 17);
    out.finish();
    out.finish();
    CHECK(content() == "-12 18446744073709551615 0.1 0.10000000000000001 -1.7976931348623157e+308");
}

TEST_CASE("more than the buffer holds arrives in order") {
    std::string wish;
    io::CheckedOutput out(scratch(), "shown");
    for (int i = 0; i < 300000; ++i) {
        out.number(i);
        out.text("\n");
        wish.append(std::to_string(i)).append("\n");
    }
    out.bytes(wish.data(), wish.size());  // longer than the buffer, too
    out.finish();
    CHECK(content() == wish + wish);
    fs::remove(scratch());
}

TEST_CASE("a stream may go back and write over what it wrote") {
    io::CheckedOutput out(scratch(), "shown");
    std::ostream stream(&out);
    stream << "offset=....;";
    const auto end = stream.tellp();
    CHECK(end == std::ostream::pos_type(12));
    stream.seekp(7);
    stream << "1234";
    CHECK(stream.tellp() == std::ostream::pos_type(11));
    stream.seekp(end);
    stream << "end" << std::flush;
    CHECK(stream.tellp() == std::ostream::pos_type(15));
    stream.seekp(0, std::ios::end);
    stream.put('!');
    out.finish();
    CHECK(content() == "offset=1234;end!");
    fs::remove(scratch());
}

TEST_CASE("what cannot be opened or written is named with its reason") {
    CHECK_THROWS_WITH(io::CheckedOutput(scratch() + "_none/a", "the name"),
                      Catch::Contains("the name") && Catch::Contains("No such file"));
    io::CheckedOutput out("/dev/full", "the name");
    out.text("lost");
    CHECK_THROWS_WITH(out.finish(), Catch::Contains("the name") && Catch::Contains("completely: No space left"));
    CHECK_THROWS_AS(out.finish(), FileError);  // it stays lost
    io::CheckedOutput behind("/dev/full", "the name");
    std::ostream stream(&behind);
    stream << "lost" << std::flush;  // swallows the exception
    CHECK(stream.bad());
    CHECK_THROWS_AS(behind.finish(), FileError);
}
