module precision
  implicit none
  integer, parameter :: real_kind = kind(1.d0)
end module precision
