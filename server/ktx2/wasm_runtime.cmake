# Sets without_signals: what makes the runtime in the folder WASM_RUNTIME check bounds by code, not by a handler of
# SIGSEGV, which would be the process's. Later versions have another name for it and warn of the earlier one.
file(STRINGS ${WASM_RUNTIME}/wasm-rt.h without_signals REGEX "define WASM_RT_USE_MMAP 0")
if(without_signals)
    set(without_signals WASM_RT_USE_MMAP=0)
else()
    set(without_signals WASM_RT_MEMCHECK_SIGNAL_HANDLER=0)
endif()
if(CMAKE_SCRIPT_MODE_FILE)
    message(NOTICE ${without_signals})
endif()
