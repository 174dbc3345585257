# Writes OUT, a header of the names that wasm2c gives what it makes of the transcoder. In the WebAssembly imports and
# exports have one letter each; SCRIPT, emscripten's JavaScript beside it, tells whose.
file(READ ${SCRIPT} script)
execute_process(COMMAND ${WASM2C} --version OUTPUT_VARIABLE version OUTPUT_STRIP_TRAILING_WHITESPACE
                COMMAND_ERROR_IS_FATAL ANY)
if(version VERSION_LESS 1.0.33)
    set(import Z_aZ_)
    set(export Z_basisZ_)
    set(names "#define BASIS_HOST Z_a_instance_t\n#define BASIS_MODULE Z_basis_instance_t\n"
              "#define BASIS_INIT Z_basis_init_module\n"
              "#define BASIS_INSTANTIATE Z_basis_instantiate\n#define BASIS_FREE Z_basis_free\n")
else()
    set(import w2c_a_)
    set(export w2c_basis_)
    set(names "#define BASIS_HOST w2c_a\n#define BASIS_MODULE w2c_basis\n"
              "#define BASIS_INIT() static_cast<void>(0)\n"
              "#define BASIS_INSTANTIATE wasm2c_basis_instantiate\n#define BASIS_FREE wasm2c_basis_free\n")
endif()

if(NOT script MATCHES "wasmImports={([^}]*)}")
    message(FATAL_ERROR "${SCRIPT} does not tell what the transcoder imports")
endif()
string(REPLACE "," ";" entries "${CMAKE_MATCH_1}")
foreach(entry IN LISTS entries)
    string(REGEX MATCH "^([A-Za-z]+):_+(.+)$" found "${entry}")
    list(APPEND names "#define IMPORT_${CMAKE_MATCH_2} ${import}${CMAKE_MATCH_1}\n")
endforeach()
foreach(name wasmMemory wasmTable ___wasm_call_ctors)
    if(NOT script MATCHES "[^A-Za-z_]${name}=wasmExports\\[\"([A-Za-z]+)\"\\]")
        message(FATAL_ERROR "${SCRIPT} does not tell what ${name} is")
    endif()
    set(letter ${CMAKE_MATCH_1})
    string(REGEX REPLACE "^_+" "" name ${name})
    list(APPEND names "#define EXPORT_${name} ${export}${letter}\n")
endforeach()
file(WRITE ${OUT} "#pragma once\n" ${names})
