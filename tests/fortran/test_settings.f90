! Texts, options, and how a context is made and heard, through the module tetlod: each procedure hands on what it gets.
module settings_tests
  use, intrinsic :: ieee_arithmetic, only: ieee_get_halting_mode, ieee_invalid, ieee_quiet_nan, ieee_set_halting_mode, &
    ieee_value
  use, intrinsic :: iso_c_binding, only: c_associated, c_f_pointer, c_funloc, c_funptr, c_int32_t, c_loc, &
    c_null_ptr, c_ptr, c_size_t
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use test_box
  use tetlod
  implicit none

  ! What an allocator of the host's was asked for, and what a log heard.
  type :: tally
    integer(c_size_t) :: calls = 0, taken = 0, held = 0
  end type
  type :: heard
    integer :: calls = 0, lowest = huge(0)
    logical :: all_have_text = .true.
  end type
  type :: canceller
    type(tetlod_context) :: lod
    integer :: calls = 0
  end type

  interface
    function aligned_alloc(alignment, bytes) result(memory) bind(C)
      import :: c_ptr, c_size_t
      integer(c_size_t), value :: alignment, bytes
      type(c_ptr) :: memory
    end function
    subroutine c_free(memory) bind(C, name="free")
      import :: c_ptr
      type(c_ptr), value :: memory
    end subroutine
  end interface

contains

  subroutine test_texts()
    integer(int32) :: major, minor, patch
    character(len=20) :: version
    call tetlod_version(major, minor, patch)
    call expect(all([major, minor, patch] == [TETLOD_VERSION_MAJOR, TETLOD_VERSION_MINOR, TETLOD_VERSION_PATCH]), &
                "the library's version is the module's")
    write (version, '(i0, ".", i0, ".", i0)') major, minor, patch
    call expect(index(tetlod_build_info(), trim(version)) > 0, "the build's text names the version")
    call expect(tetlod_status_text(TETLOD_ERR_STATE) /= tetlod_status_text(TETLOD_OK), "texts tell statuses apart")
    call expect(tetlod_stage_name(1) == "boundary", "the name of a stage")
    call expect(tetlod_stage_name(2) == "decimate", "the name of another")
    call expect(tetlod_option_from_name("no-such") == 0, "no such option")
  end subroutine

  ! Of every option; those of integers, too.
  function options_of(lod) result(all_values)
    type(tetlod_context), intent(in) :: lod
    real(real64), allocatable :: all_values(:)
    type(tetlod_bounds) :: bounds
    real(real64) :: value
    integer(int64) :: whole
    integer(int32) :: option
    allocate (all_values(0))
    do option = 1, 999
      if (tetlod_option_name(option) == "") exit
      call tetlod_option_bounds(option, bounds)
      if (bounds%is_integer == 1) then
        call lod%get_int(option, whole)
        value = real(whole, real64)
      else
        call lod%get_real(option, value)
      end if
      all_values = [all_values, value]
    end do
  end function

  ! wanted: what all options were, and are but for this one.
  subroutine expect_alone(lod, wanted, option, value, what)
    type(tetlod_context), intent(in) :: lod
    real(real64), intent(inout) :: wanted(:)
    integer(int32), intent(in) :: option
    real(real64), intent(in) :: value
    character(len=*), intent(in) :: what
    wanted(option) = value
    call expect(all(same(options_of(lod), wanted)), what//" sets its option alone")
  end subroutine

  subroutine test_setters()
    type(tetlod_context) :: lod
    real(real64), allocatable :: wanted(:)
    call lod%create()
    wanted = options_of(lod)
    call expect(size(wanted) == TETLOD_OPT_REMESH, "the test looks at all options")
    call lod%set_rho(0.0625)
    call expect_alone(lod, wanted, TETLOD_OPT_RHO, 0.0625d0, "set_rho of real32")
    call lod%set_rho(0.3d0)
    call expect_alone(lod, wanted, TETLOD_OPT_RHO, 0.3d0, "set_rho of real64")
    call lod%set_sigma(0.0625)
    call expect_alone(lod, wanted, TETLOD_OPT_SIGMA, 0.0625d0, "set_sigma of real32")
    call lod%set_sigma(0.3d0)
    call expect_alone(lod, wanted, TETLOD_OPT_SIGMA, 0.3d0, "set_sigma of real64")
    call lod%set_lambda(0.0625)
    call expect_alone(lod, wanted, TETLOD_OPT_LAMBDA, 0.0625d0, "set_lambda of real32")
    call lod%set_lambda(0.3d0)
    call expect_alone(lod, wanted, TETLOD_OPT_LAMBDA, 0.3d0, "set_lambda of real64")
    call lod%set_min_distance(0.0625)
    call expect_alone(lod, wanted, TETLOD_OPT_MIN_DISTANCE, 0.0625d0, "set_min_distance of real32")
    call lod%set_min_distance(0.3d0)
    call expect_alone(lod, wanted, TETLOD_OPT_MIN_DISTANCE, 0.3d0, "set_min_distance of real64")
    call lod%set_real(TETLOD_OPT_TARGET_RATIO, 0.0625)
    call expect_alone(lod, wanted, TETLOD_OPT_TARGET_RATIO, 0.0625d0, "set_real of real32")
    call lod%set_real(TETLOD_OPT_TARGET_RATIO, 0.3d0)
    call expect_alone(lod, wanted, TETLOD_OPT_TARGET_RATIO, 0.3d0, "set_real of real64")
    call lod%set_int(TETLOD_OPT_SEED, 7_int32)
    call expect_alone(lod, wanted, TETLOD_OPT_SEED, 7d0, "set_int of int32")
    call lod%set_int(TETLOD_OPT_SEED, 2_int64**40)
    call expect_alone(lod, wanted, TETLOD_OPT_SEED, 2d0**40, "set_int of int64")
    call lod%destroy()
  end subroutine

  subroutine test_getters()
    type(tetlod_context) :: lod
    real(real32) :: single
    integer(int32) :: narrow
    integer(int64) :: wide
    integer :: stat
    call lod%create()
    call lod%set_rho(0.3d0)
    call lod%get_real(TETLOD_OPT_RHO, single)
    call expect(abs(single - 0.3) < tiny(single), "get_real of real32")
    call lod%set_int(TETLOD_OPT_SEED, 5)
    call lod%get_int(TETLOD_OPT_SEED, narrow)
    call expect(narrow == 5, "get_int of int32")
    call lod%set_int(TETLOD_OPT_SEED, 2_int64**40 + 1)
    call lod%get_int(TETLOD_OPT_SEED, wide)
    call expect(wide == 2_int64**40 + 1, "get_int of int64")
    call lod%get_int(TETLOD_OPT_SEED, narrow)
    call expect(narrow == huge(narrow), "what int32 cannot hold is cut")
    call lod%get_int(TETLOD_OPT_RHO, narrow, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION .and. narrow == huge(narrow), "a real is no integer, int32")
    call lod%get_int(TETLOD_OPT_RHO, wide, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION .and. wide == 2_int64**40 + 1, "a real is no integer, int64")
    call lod%get_real(TETLOD_OPT_SEED, single, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION .and. abs(single - 0.3) < tiny(single), "an integer is no real")
    call lod%destroy()
  end subroutine

  ! Also where the host's invalid operations end it.
  subroutine test_not_a_number()
    type(tetlod_context) :: lod
    integer :: stat
    logical :: halts
    call lod%create()
    call ieee_get_halting_mode(ieee_invalid, halts)
    call ieee_set_halting_mode(ieee_invalid, .true.)
    call lod%set_real(TETLOD_OPT_TARGET_RATIO, ieee_value(0.0, ieee_quiet_nan), stat=stat)
    call ieee_set_halting_mode(ieee_invalid, halts)
    call expect(stat == TETLOD_ERR_OPTION, "real32 that is no number")
    call lod%destroy()
  end subroutine

  subroutine test_presets()
    type(tetlod_context) :: lod
    integer :: effort, stat
    call lod%create()
    call lod%set_preset(TETLOD_PRESET_FAST)
    call lod%get_int(TETLOD_OPT_EFFORT, effort)
    call expect(effort == TETLOD_EFFORT_FAST, "a preset sets what it governs")
    call lod%set_preset(17, stat=stat)
    call expect(stat == TETLOD_ERR_OPTION, "no such preset")
    call lod%destroy()
  end subroutine

  function allocate_here(user, bytes, alignment) result(memory) bind(C, name="")
    type(c_ptr), value :: user
    integer(c_size_t), value :: bytes, alignment
    type(c_ptr) :: memory
    type(tally), pointer :: counted
    call c_f_pointer(user, counted)
    counted%calls = counted%calls + 1
    counted%taken = counted%taken + bytes
    counted%held = counted%held + bytes
    memory = aligned_alloc(max(alignment, 8_c_size_t), (bytes / alignment + 1) * max(alignment, 8_c_size_t))
  end function

  subroutine release_here(user, memory, bytes, alignment) bind(C, name="")
    type(c_ptr), value :: user, memory
    integer(c_size_t), value :: bytes, alignment
    type(tally), pointer :: counted
    call c_f_pointer(user, counted)
    if (alignment > 0) counted%held = counted%held - bytes
    call c_free(memory)
  end subroutine

  subroutine test_allocator()
    type(tetlod_context) :: lod
    type(tally), target :: counted
    type(tetlod_run_report) :: report
    type(c_funptr) :: allocate, release  ! as arguments gfortran makes them constants that cannot be relocated
    allocate = c_funloc(allocate_here)
    release = c_funloc(release_here)
    call lod%create(allocate=allocate, release=release, allocator_user=c_loc(counted))
    call submit_box(lod)
    call lod%run()
    call lod%fetch_report(report)
    call expect(counted%calls > 0 .and. counted%taken > size(tets), "memory is the host's")
    call expect(counted%held > 0, "the result is in it")
    call lod%destroy()
    call expect(counted%held == 0, "all of it is given back")
  end subroutine

  subroutine test_memory_limit()
    type(tetlod_context) :: lod
    integer :: stat
    call lod%create(memory_limit=10000_int64)
    call submit_box(lod)
    call lod%run(stat=stat)
    call expect(stat == TETLOD_ERR_MEMORY_LIMIT, "a memory limit holds")
    call lod%destroy()
  end subroutine

  subroutine test_remesher()
    type(tetlod_context) :: lod
    character(len=200) :: message
    integer :: stat
    message = ""
    call lod%create(remesher="/no/such/program  ")
    call submit_box(lod)
    call lod%run(stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_BACKEND_MISSING, "there is no such remesher")
    call expect(index(message, "/no/such/program") > 0, "it is named: "//message)
    call expect(lod%last_message() == trim(message), "the last message is what errmsg got")
    call lod%destroy()
  end subroutine

  subroutine test_handle()
    type(tetlod_context) :: lod
    call expect(.not. c_associated(lod%c_handle()), "no handle before create")
    call lod%create()
    call expect(c_associated(lod%c_handle()), "a handle after it")
    call lod%destroy()
    call expect(.not. c_associated(lod%c_handle()), "none after destroy")
  end subroutine

  subroutine cancel_in_progress(stage, fraction, cancel, user)
    integer(int32), intent(in) :: stage
    real(real64), intent(in) :: fraction
    logical, intent(inout) :: cancel
    class(*), pointer, intent(in) :: user
    call expect(stage >= 0 .and. fraction >= 0 .and. .not. cancel, "stage, fraction and cancel")
    select type (user)
    type is (canceller)
      user%calls = user%calls + 1
      call user%lod%cancel()
    end select
  end subroutine

  ! As from another thread, at a moment that is the same in each run.
  subroutine test_cancel()
    type(tetlod_context) :: lod
    type(canceller), target :: host
    integer :: stat
    call lod%create()
    call submit_box(lod)
    call lod%set_progress(cancel_in_progress, user=host)
    host%lod = lod
    call lod%run(stat=stat)
    call expect(stat == TETLOD_ERR_CANCELLED .and. host%calls > 0, "cancel ends the run")
    call lod%destroy()
  end subroutine

  subroutine hear(level, message, user)
    integer(int32), intent(in) :: level
    character(len=*), intent(in) :: message
    class(*), pointer, intent(in) :: user
    select type (user)
    type is (heard)
      user%calls = user%calls + 1
      user%lowest = min(user%lowest, level)
      user%all_have_text = user%all_have_text .and. len_trim(message) == len(message) .and. len(message) > 9
    end select
  end subroutine

  ! A size that cannot be had, as is told at level 1.
  subroutine test_log()
    type(tetlod_context) :: lod
    type(heard), target :: by_default, warnings
    call lod%create()
    call submit_box(lod)
    call lod%set_real(TETLOD_OPT_TARGET_RATIO, 1d-6)
    call lod%set_log(hear, user=by_default)
    call lod%run()
    call expect(by_default%calls > 0 .and. by_default%lowest == 1, "information is heard without a level")
    call expect(by_default%all_have_text, "messages are whole")
    call lod%set_log(hear, min_level=2, user=warnings)
    call lod%run()
    call expect(warnings%calls == 0, "it is no warning")
    call lod%destroy()
  end subroutine

  ! What a program that is no worker says is told at level 0.
  subroutine test_debugging()
    type(tetlod_context) :: lod
    type(heard), target :: by_default, everything
    integer :: stat
    call lod%create(remesher="/bin/cp")
    call submit_box(lod)
    call lod%set_log(hear, min_level=0, user=everything)
    call lod%run(stat=stat)
    call expect(everything%calls > 0 .and. everything%lowest == 0, "level 0 is everything")
    call lod%set_log(hear, user=by_default)
    call lod%run(stat=stat)
    call expect(by_default%lowest > 0, "debugging is not heard without a level")
    call lod%destroy()
  end subroutine
end module

program test_settings
  use settings_tests
  implicit none
  call make_mesh()
  call test_texts()
  call test_setters()
  call test_getters()
  call test_presets()
  call test_not_a_number()
  call test_allocator()
  call test_memory_limit()
  call test_remesher()
  call test_handle()
  call test_cancel()
  call test_log()
  call test_debugging()
  if (failures > 0) error stop "the settings of the module tetlod fail"
  print '("ok")'
end program
