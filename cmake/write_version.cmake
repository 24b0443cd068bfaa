# Writes OUTPUT from INPUT, with the commits of SOURCE_FOLDER and of each of STAGE_FOLDERS (separated by |).
# Runs at each build, because files may change without a commit; OUTPUT changes only if a commit or a state did.
find_package(Git QUIET)

# The commit that `folder` is at, and whether files below it differ from it: `untracked` ("normal" or "no") says
# whether new files count.
function(commit_of folder untracked result)
  set(commit "")
  if(GIT_FOUND)
    execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${folder}" rev-parse HEAD
      OUTPUT_VARIABLE commit ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${folder}" status --porcelain --untracked-files=${untracked} -- .
      OUTPUT_VARIABLE changes ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  endif()
  if(NOT commit MATCHES "^[0-9a-f]+$")
    set(commit "unknown")
  elseif(changes)
    string(APPEND commit "-dirty")
  endif()
  set(${result} "${commit}" PARENT_SCOPE)
endfunction()

# COMMIT_INPUT is what an earlier call wrote to COMMIT_OUTPUT: the commit of an installed croon.
set(CROON_COMMIT "unknown")
if(COMMIT_INPUT)
  include("${COMMIT_INPUT}")
elseif(GIT_FOUND)
  # A copy of the sources inside somebody else's repository is not at that repository's commit.
  execute_process(COMMAND "${GIT_EXECUTABLE}" -C "${SOURCE_FOLDER}" rev-parse --show-toplevel
    OUTPUT_VARIABLE top ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH "${SOURCE_FOLDER}" source_folder)
  if(top STREQUAL source_folder)
    commit_of("${SOURCE_FOLDER}" no CROON_COMMIT)
  endif()
endif()
if(COMMIT_OUTPUT)
  file(WRITE "${COMMIT_OUTPUT}" "set(CROON_COMMIT \"${CROON_COMMIT}\")\n")
endif()

set(CROON_STAGE_FOLDERS "")
string(REPLACE "|" ";" folders "${STAGE_FOLDERS}")
foreach(folder IN LISTS folders)
  commit_of("${folder}" normal commit)
  string(REPLACE "\\" "\\\\" text "${folder}")
  string(REPLACE "\"" "\\\"" text "${text}")
  string(APPEND CROON_STAGE_FOLDERS "      {\"${text}\", \"${commit}\"},\n")
endforeach()
configure_file("${INPUT}" "${OUTPUT}")
