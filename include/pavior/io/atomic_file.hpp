#pragma once
/// \file
/// Files that appear whole or not at all.

#include <functional>
#include <string>

namespace pavior {

/// A file that is written under another name in the same directory, with the same extension, and put in its place when
/// it is whole: until commit() what stood there stays as it was, and nothing is left behind if commit() never comes.
/// Links are followed: the file that they name is replaced, they stay. Thread-safe on different files.
class AtomicFile {
public:
    /// \throws FileError if \p file is a directory, a device or a link without end, or if its directory does not exist
    /// or cannot be written to
    explicit AtomicFile(const std::string& file);
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;
    ~AtomicFile();

    /// Calls write(temporary); a FileError about that name becomes one about the file itself.
    void write(const std::function<void(const std::string& temporary)>& write) const;
    /// The file that is made or replaced: behind the links.
    [[nodiscard]] const std::string& target() const { return target_; }
    /// Brings what was written to the disk. \throws FileError if nothing was written, or not all of it arrives
    void finish();
    /// finish() unless that was done, then puts it in place. \throws FileError
    void commit();

private:
    std::string file_;  ///< as given, for messages
    std::string target_;
    std::string temporary_;
    bool finished_ = false;
};

/// Calls write(temporary) with a name in the directory of \p file and with its extension, then renames the result to
/// \p file. If \p write throws or leaves nothing behind, the temporary is removed and \p file stays as it was.
/// \throws FileError as AtomicFile; whatever \p write throws
void write_atomically(const std::string& file, const std::function<void(const std::string& temporary)>& write);

/// Removes the temporaries of all AtomicFile of this process, none of which gets into place any more: for the end of a
/// process that cannot unwind. Waits for a commit() under way. Thread-safe.
void discard_unfinished_files() noexcept;

}  // namespace pavior
