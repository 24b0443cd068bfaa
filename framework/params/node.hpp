#pragma once

#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/base/error.hpp"

namespace croon::params {

/// The file and key that a member of a merged object comes from.
struct MemberOrigin {
  std::string file;
  std::string key;  ///< As written in the file.
};

/// The origins of members, by their keys in the merged object.
using MemberOrigins = std::map<std::string, MemberOrigin>;

/// A value in a JSON file with its file and pointer, so that a reader can report faults in it.
/// Faults are collected, not thrown: the user sees all of them at once. Cheap to copy; the JSON
/// value and the list of faults must outlive it.
class Node {
 public:
  Node(const nlohmann::json& value, std::string file, std::vector<Fault>& faults);
  /// An object merged from several files: a fault in a member names the file it comes from.
  Node(const nlohmann::json& value, std::string file, std::vector<Fault>& faults,
       MemberOrigins origins);

  const nlohmann::json& value() const { return *value_; }
  const std::string& file() const { return file_; }
  /// RFC 6901 pointer of this value, empty at the root.
  const std::string& pointer() const { return pointer_; }

  /// The member `key` of an object; it must exist.
  Node member(const std::string& key) const;
  /// The element `index` of an array.
  Node element(std::size_t index) const;
  bool has(const std::string& key) const;
  /// Whether this is an object; notes no fault.
  bool has_members() const;

  /// This node, which appends remarks on former names of keys to `notes`, each once.
  Node noting(std::vector<Fault>& notes) const;
  /// This object with the key `former`, if it exists, renamed to `key`; positions are those of the
  /// written keys. Makes a note of it, or a fault if the object has both.
  Node renamed(const std::string& former, const std::string& key) const;

  /// RFC 6901 pointer of the member `key` of this object, which need not exist.
  std::string pointer_to(const std::string& key) const;

  /// Notes a fault in this value. `parts`: see Fault.
  void fault(const std::string& message, std::vector<std::string> parts = {}) const;
  /// Notes `expected WHAT, found VALUE`.
  void expected(const std::string& what) const;

  /// The number of faults found so far, in this node and elsewhere.
  std::size_t fault_count() const { return faults_->size(); }

  /// Whether this is an object; if not, notes a fault.
  bool is_object() const;
  /// Whether this is an array; if not, notes a fault.
  bool is_array() const;
  /// Notes a fault, with the nearest known key, for each key of this object that is not in `known`.
  void refuse_unknown_keys(const std::vector<std::string>& known) const;
  /// Notes a fault if the member `key` is missing. `parts` are the pointers of the values that
  /// require it, see Fault.
  bool require(const std::string& key, std::vector<std::string> parts = {}) const;

  /// The value at `path`, e.g. "sweep/rotation_deg", below this object; null if it does not exist.
  const nlohmann::json* find(const std::string& path) const;

  /// Reads the value into `out` and returns true, or notes a fault.
  bool read(bool& out) const;
  bool read(double& out) const;
  bool read(int& out) const;
  bool read(std::string& out) const;

 private:
  const nlohmann::json* value_;
  std::string file_;
  std::string pointer_;
  std::vector<Fault>* faults_;
  std::vector<Fault>* notes_ = nullptr;
  std::shared_ptr<const nlohmann::json> renamed_;  ///< Contains the value if a key was renamed.
  std::shared_ptr<const MemberOrigins> origins_;   ///< Null unless merged or renamed.
};

}  // namespace croon::params
