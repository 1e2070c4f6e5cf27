duolux_test(film_test
  SOURCES film_accumulate_test.cpp film_image_test.cpp film_layers_test.cpp film_malformed_test.cpp film_write_failure_test.cpp
          film_sheet_test.cpp film_samples.cpp
  LINK duolux_film OpenEXR::OpenEXR PNG::PNG)
