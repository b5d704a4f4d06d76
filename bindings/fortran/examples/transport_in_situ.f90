! A solver that keeps a small copy of every so many of its steps, made inside the program by tetlod.
!
!     transport_in_situ [CELLS [STEPS [EVERY [PREFIX]]]]        32 (196,608 tets), 100, 10, transport
!
! Writes PREFIX_0000.vtu, ... and PREFIX.pvd, which names them; prints what that cost beside the solver. EVERY 0: the
! solver alone.
program transport_in_situ
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use box_mesh, only: make_box
  use tetlod
  use transport, only: advance, begin_transport, bytes_of, flow
  use vtu_series, only: add_to_series, series
  implicit none

  type :: cost
    real(real64) :: solver = 0, tetlod = 0, files = 0  ! seconds
    integer(int64) :: peak = 0                         ! bytes of tetlod, its worker included
    integer :: runs = 0
  end type

  type(flow), target :: f
  type(tetlod_context) :: lod
  type(series) :: copies
  type(cost) :: spent
  character(len=:), allocatable :: prefix
  integer :: cells, steps, every, step
  real(real64) :: begun

  cells = argument(1, 32)
  steps = argument(2, 100)
  every = argument(3, 10)
  prefix = text_argument(4, "transport")
  call make_flow(cells, f)
  if (every > 0) call begin_copies(f, prefix, lod, copies)
  do step = 1, steps
    begun = now()
    call advance(f)
    spent%solver = spent%solver + now() - begun
    if (every > 0) then
      if (mod(step, every) == 0) call keep_copy(f, lod, copies, spent)
    end if
  end do
  call print_cost(f, spent, steps)
  if (spent%runs > 0) call print_copies(f, lod, copies, spent)
  call lod%destroy()

contains

  subroutine make_flow(cells, f)
    integer, intent(in) :: cells
    type(flow), intent(out) :: f
    real(real64), allocatable :: xyz(:, :)
    integer(int32), allocatable :: tets(:, :)
    call make_box(cells, xyz, tets)
    call begin_transport(xyz, tets, f)
    print '("box: ", i0, " vertices, ", i0, " tets")', size(xyz, 2), size(tets, 2)
  end subroutine

  ! The solver lends its arrays once: tetlod reads what they hold when it runs.
  subroutine begin_copies(f, prefix, lod, copies)
    type(flow), intent(in), target :: f
    character(len=*), intent(in) :: prefix
    type(tetlod_context), intent(inout) :: lod
    type(series), intent(out) :: copies
    copies%prefix = prefix
    copies%name = "concentration"
    call lod%create()
    call lod%set_preset(TETLOD_PRESET_FAST)
    call lod%set_real(TETLOD_OPT_TARGET_RATIO, 0.03)
    call lod%submit_points(f%xyz)
    call lod%submit_tets(f%tets)
    call lod%submit_scalars(copies%name, f%concentration)
  end subroutine

  subroutine keep_copy(f, lod, copies, spent)
    type(flow), intent(in) :: f
    type(tetlod_context), intent(inout) :: lod
    type(series), intent(inout) :: copies
    type(cost), intent(inout) :: spent
    real(real64), pointer :: xyz(:, :), values(:)
    integer(int32), pointer :: tets(:, :)
    type(tetlod_run_report) :: report
    real(real64) :: begun
    integer :: stat
    begun = now()
    call lod%run()
    call lod%view_points(xyz)
    call lod%view_tets(tets)
    call lod%view_scalars(values)
    spent%tetlod = spent%tetlod + now() - begun
    begun = now()
    call add_to_series(copies, f%time, xyz, tets, values, stat)
    if (stat /= 0) error stop "transport_in_situ: cannot write "//copies%prefix
    spent%files = spent%files + now() - begun
    call lod%fetch_report(report)
    spent%peak = max(spent%peak, report%peak_bytes + report%worker_peak_bytes)
    spent%runs = spent%runs + 1
    print '("time ", f0.2, ": ", i0, " tets, ", f0.3, " s")', f%time, report%tets_out, report%seconds_total
  end subroutine

  subroutine print_cost(f, spent, steps)
    type(flow), intent(in) :: f
    type(cost), intent(in) :: spent
    integer, intent(in) :: steps
    print '("solver: ", f0.4, " s a step, ", f0.1, " MB; the last step took ", i0, " systems, ", i0, " iterations")', &
      spent%solver / steps, bytes_of(f) * 1d-6, f%systems, f%iterations
  end subroutine

  ! The error is measured of the last copy, when nobody's time is counted any more.
  subroutine print_copies(f, lod, copies, spent)
    type(flow), intent(in) :: f
    type(tetlod_context), intent(inout) :: lod
    type(series), intent(in) :: copies
    type(cost), intent(in) :: spent
    type(tetlod_error_report) :: error
    print '("tetlod: ", f0.4, " s a copy, ", f0.1, " MB at its peak; files: ", f0.4, " s and ", f0.2, " MB a copy")', &
      spent%tetlod / spent%runs, spent%peak * 1d-6, spent%files / spent%runs, copies%bytes * 1d-6 / copies%count
    print '("the whole mesh would be ", f0.2, " MB a copy")', (32 * size(f%xyz, 2) + 21 * size(f%tets, 2)) * 1d-6
    print '("with tetlod the program takes ", f0.3, " times the solver''s time")', &
      (spent%solver + spent%tetlod + spent%files) / spent%solver
    call lod%measure_error(0, error)
    print '("error of the last copy: RMS ", f0.2, " %, at most ", f0.1, " % of the range")', 100 * error%rms, &
      100 * error%max
    print '("Open ", a, ".pvd in ParaView")', copies%prefix
  end subroutine

  real(real64) function now()
    integer(int64) :: count, rate
    call system_clock(count, rate)
    now = real(count, real64) / real(rate, real64)
  end function

  function text_argument(position, preset) result(text)
    integer, intent(in) :: position
    character(len=*), intent(in) :: preset
    character(len=:), allocatable :: text
    integer :: length
    call get_command_argument(position, length=length)
    if (length == 0) then
      text = preset
    else
      allocate (character(len=length) :: text)
      call get_command_argument(position, text)
    end if
  end function

  integer function argument(position, preset)
    integer, intent(in) :: position, preset
    character(len=:), allocatable :: text
    integer :: stat
    argument = preset
    text = text_argument(position, "")
    if (text == "") return
    read (text, '(i10)', iostat=stat) argument
    if (verify(text, "0123456789") /= 0 .or. len(text) > 9 .or. stat /= 0 .or. argument < merge(0, 1, position == 3)) &
      error stop "transport_in_situ: '"//text//"' is no number of cells, of steps, or of steps between copies"
  end function
end program
